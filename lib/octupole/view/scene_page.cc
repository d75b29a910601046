#include "octupole/view/scene_page.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "octupole/io/atomic_file.h"
#include "octupole/view/internal/json_text.h"
#include "octupole/view/internal/page_template.h"

namespace octupole {
namespace {

using internal::JsonBytes;
using internal::JsonNumber;
using internal::JsonString;

// The words of a page are its own, so that they cannot be mistaken for what scenes say.
constexpr std::string_view kTitle = "@TITLE@", kScenes = "@SCENES@";
constexpr double kMaxInt16 = 32767, kMaxUInt16 = 65535;

template <typename Integer>
void Append(Integer value, std::vector<unsigned char>* bytes) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i) bytes->push_back(static_cast<unsigned char>(value >> 8 * i));
}

[[noreturn]] void Fail(const std::string& part, const std::string& what) {
  throw std::invalid_argument("WriteScenePage: " + part + ": " + what);
}

void CheckSizes(const std::string& part, std::size_t expected, std::initializer_list<std::size_t> sizes) {
  for (const std::size_t size : sizes) {
    if (size != expected) Fail(part, std::to_string(size) + " values for " + std::to_string(expected));
  }
}

template <std::size_t N>
std::string Indices(const std::string& part, const std::vector<std::array<int, N>>& cells, std::size_t num_points) {
  std::vector<unsigned char> bytes;
  bytes.reserve(4 * N * cells.size());
  for (const auto& cell : cells) {
    for (const int index : cell) {
      if (index < 0 || static_cast<std::size_t>(index) >= num_points) {
        Fail(part, "index " + std::to_string(index) + " of " + std::to_string(num_points) + " points");
      }
      Append(static_cast<std::uint32_t>(index), &bytes);
    }
  }
  return JsonBytes(bytes);
}

// Unit quaternions x, y, z; w is not negative, and follows.
std::string Rotations(const std::string& part, const std::vector<Eigen::Matrix3d>& frames) {
  std::vector<unsigned char> bytes;
  bytes.reserve(6 * frames.size());
  for (const Eigen::Matrix3d& frame : frames) {
    if (!frame.allFinite()) Fail(part, "a frame that is not finite");
    Eigen::Quaterniond q(frame);
    q.normalize();
    if (q.w() < 0) q.coeffs() = -q.coeffs();
    for (const double x : q.vec()) Append(static_cast<std::int16_t>(std::lround(x * kMaxInt16)), &bytes);
  }
  return JsonBytes(bytes);
}

// The largest number and all of them as shares of it.
std::string Shares(const std::string& part, const std::vector<double>& numbers) {
  double largest = 0;
  for (const double x : numbers) {
    if (!(x >= 0) || std::isinf(x)) Fail(part, "the value " + JsonNumber(x));
    largest = std::max(largest, x);
  }
  std::vector<unsigned char> bytes;
  bytes.reserve(2 * numbers.size());
  for (const double x : numbers) {
    Append(static_cast<std::uint16_t>(largest > 0 ? std::lround(x / largest * kMaxUInt16) : 0), &bytes);
  }
  return "{\"largest\":" + JsonNumber(largest) + ",\"shares\":" + JsonBytes(bytes) + "}";
}

std::string Bool(bool value) { return value ? "true" : "false"; }

template <typename Parts, typename Write>
std::string Array(const Parts& parts, const Write& write) {
  std::string json = "[";
  for (const auto& part : parts) json += (json.size() > 1 ? "," : "") + write(part);
  return json + "]";
}

/// One scene as JSON; positions are shares of the cube that holds it.
class SceneJson {
 public:
  explicit SceneJson(const Scene& scene) : scene_(scene) {
    for (const SceneSurface& surface : scene.surfaces) Extend(surface.name, surface.points);
    for (const SceneLines& lines : scene.lines) Extend(lines.name, lines.points);
    for (const SceneCurve& curve : scene.curves) Extend("a curve", curve.points);
    for (const SceneMarker& marker : scene.markers) Extend("a marker", {marker.point});
    for (const SceneBoxes& boxes : scene.boxes) Extend(boxes.name, boxes.centers);
    if (box_.isEmpty()) box_.extend(Eigen::Vector3d(0, 0, 0));
    size_ = box_.sizes().maxCoeff();
    if (!(size_ > 0)) size_ = 1;
  }

  std::string Text() const {
    const auto kind = [&](int index) {
      if (index < 0 || static_cast<std::size_t>(index) >= scene_.kinds.size()) {
        Fail(scene_.title, "kind " + std::to_string(index) + " of " + std::to_string(scene_.kinds.size()));
      }
      return std::to_string(index);
    };
    std::string json = "{\"title\":" + JsonString(scene_.title);
    json += ",\"origin\":" + Array(box_.min(), JsonNumber) + ",\"size\":" + JsonNumber(size_);
    json += ",\"extent\":" + Array(Eigen::Vector3d(box_.sizes()), JsonNumber);
    json += ",\"kinds\":" + Array(scene_.kinds, [](const SceneKind& k) {
              return "{\"name\":" + JsonString(k.name) + ",\"color\":" + JsonString(k.color) + "}";
            });
    json += ",\"surfaces\":" + Array(scene_.surfaces, [&](const SceneSurface& s) {
              return "{\"name\":" + JsonString(s.name) + ",\"isSolid\":" + Bool(s.is_solid) +
                     ",\"isOnlyOnCut\":" + Bool(s.is_only_on_cut) + ",\"points\":" + Positions(s.points) +
                     ",\"triangles\":" + Indices(s.name, s.triangles, s.points.size()) + "}";
            });
    json += ",\"lines\":" + Array(scene_.lines, [&](const SceneLines& l) {
              return "{\"name\":" + JsonString(l.name) + ",\"isCut\":" + Bool(l.is_cut) +
                     ",\"points\":" + Positions(l.points) +
                     ",\"segments\":" + Indices(l.name, l.segments, l.points.size()) + "}";
            });
    json += ",\"curves\":" + Array(scene_.curves, [&](const SceneCurve& c) {
              return "{\"kind\":" + kind(c.kind) + ",\"label\":" + JsonString(c.label) +
                     ",\"points\":" + Positions(c.points) + "}";
            });
    json += ",\"markers\":" + Array(scene_.markers, [&](const SceneMarker& m) {
              return "{\"kind\":" + kind(m.kind) + ",\"label\":" + JsonString(m.label) +
                     ",\"points\":" + Positions({m.point}) + "}";
            });
    json += ",\"boxes\":" + Array(scene_.boxes, [&](const SceneBoxes& b) {
              CheckSizes(b.name, b.centers.size(), {b.frames.size(), b.spacings.size(), b.values.size()});
              return "{\"name\":" + JsonString(b.name) + ",\"valueName\":" + JsonString(b.value_name) +
                     ",\"areFlat\":" + Bool(b.are_flat) + ",\"points\":" + Positions(b.centers) +
                     ",\"rotations\":" + Rotations(b.name, b.frames) + ",\"spacings\":" + Shares(b.name, b.spacings) +
                     ",\"values\":" + Shares(b.name, b.values) + "}";
            });
    json += ",\"figures\":" + Array(scene_.figures, [](const std::pair<std::string, std::string>& figure) {
              return "[" + JsonString(figure.first) + "," + JsonString(figure.second) + "]";
            });
    return json + "}";
  }

 private:
  void Extend(const std::string& part, const std::vector<Eigen::Vector3d>& points) {
    for (const Eigen::Vector3d& point : points) {
      if (!point.allFinite()) Fail(part, "a position that is not finite");
      box_.extend(point);
    }
  }

  std::string Positions(const std::vector<Eigen::Vector3d>& points) const {
    std::vector<unsigned char> bytes;
    bytes.reserve(6 * points.size());
    for (const Eigen::Vector3d& point : points) {
      for (const double x : Eigen::Vector3d((point - box_.min()) / size_)) {
        Append(static_cast<std::uint16_t>(std::lround(x * kMaxUInt16)), &bytes);
      }
    }
    return JsonBytes(bytes);
  }

  const Scene& scene_;
  Eigen::AlignedBox3d box_;
  double size_ = 1;
};

std::string HtmlText(std::string_view text) {
  std::string html;
  for (const char c : text) {
    if (c == '&' || c == '<' || c == '>') {
      html += c == '&' ? "&amp;" : c == '<' ? "&lt;" : "&gt;";
    } else {
      html += c;
    }
  }
  return html;
}

}  // namespace

void CheckScenePages() {
  if (internal::kPageTemplateSize > 0) return;
  throw std::runtime_error(
      "this build of octupole has no viewer; install esbuild and three.js (on Debian: apt-get install esbuild "
      "libjs-three), then configure and build it again");
}

void WriteScenePage(const std::filesystem::path& path, const std::vector<Scene>& scenes) {
  CheckScenePages();
  if (scenes.empty()) throw std::invalid_argument("WriteScenePage: no scenes");
  const std::string json = Array(scenes, [](const Scene& scene) { return SceneJson(scene).Text(); });
  std::string title;
  for (const Scene& scene : scenes) title += (title.empty() ? "" : " | ") + scene.title;

  std::string page;
  for (std::size_t i = 0; i < internal::kPageTemplateSize; ++i) page += internal::kPageTemplate[i];
  const std::size_t title_at = page.find(kTitle), scenes_at = page.find(kScenes);
  const std::string_view text = page;
  WriteFileAtomically(path, [&](std::ostream& out) {
    out << text.substr(0, title_at) << HtmlText(title)
        << text.substr(title_at + kTitle.size(), scenes_at - title_at - kTitle.size()) << json
        << text.substr(scenes_at + kScenes.size());
  });
}

}  // namespace octupole
