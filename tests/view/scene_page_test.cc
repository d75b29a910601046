#include "octupole/view/scene_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "test_files.h"

namespace octupole {
namespace {

using testing::HasSubstr;

Scene MakeScene() {
  Scene scene;
  scene.title = "a \"part\" </script><b>&";
  scene.kinds = {{"kind </title>", "#123456"}};
  scene.surfaces.push_back({"skin", {{1, 2, 3}, {3, 2, 3}, {1, 6, 3}}, {{0, 1, 2}}, true});
  scene.lines.push_back({"edges", {{1, 2, 3}, {3, 2, 3}}, {{0, 1}}});
  scene.curves.push_back({0, "curve", {{1, 2, 3}, {3, 6, 3}}});
  scene.markers.push_back({0, "point", {1, 6, 3}});
  scene.boxes.push_back({"boxes", {{2, 4, 3}}, {Eigen::Matrix3d::Identity()}, {0.5}, {2}, "value"});
  scene.figures = {{"name", "<i>"}};
  return scene;
}

std::string WrittenPage(const std::vector<Scene>& scenes) {
  const TemporaryFolder folder;
  WriteScenePage(folder / "a.html", scenes);
  return ReadText(folder / "a.html");
}

// The scenes of a page, as a browser finds them.
nlohmann::json ScenesOf(const std::string& page) {
  const std::string start = "<script type=\"application/json\" id=\"scenes\">";
  const std::size_t begin = page.find(start) + start.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

std::vector<int> UInt16s(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::uint32_t bits = 0;
  int num_bits = 0;
  std::vector<int> bytes;
  for (const char c : base64.substr(0, base64.find('='))) {
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    if ((num_bits += 6) >= 8) bytes.push_back(static_cast<int>(bits >> (num_bits -= 8) & 255));
  }
  std::vector<int> numbers;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) numbers.push_back(bytes[i] + 256 * bytes[i + 1]);
  return numbers;
}

TEST(WriteScenePage, WritesPositionsAsSharesOfTheLargestExtent) {
  const nlohmann::json scenes = ScenesOf(WrittenPage({MakeScene(), MakeScene()}));
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_EQ(scenes[1]["origin"], nlohmann::json({1, 2, 3}));
  EXPECT_EQ(scenes[1]["extent"], nlohmann::json({2, 4, 0}));
  EXPECT_EQ(scenes[1]["size"], 4);
  EXPECT_EQ(UInt16s(scenes[1]["surfaces"][0]["points"]), std::vector<int>({0, 0, 0, 32768, 0, 0, 0, 65535, 0}));
  EXPECT_EQ(UInt16s(scenes[1]["surfaces"][0]["triangles"]), std::vector<int>({0, 0, 1, 0, 2, 0}));
  const nlohmann::json& boxes = scenes[1]["boxes"][0];
  EXPECT_EQ(UInt16s(boxes["rotations"]), std::vector<int>({0, 0, 0}));
  EXPECT_EQ(boxes["values"]["largest"], 2);
  EXPECT_EQ(UInt16s(boxes["values"]["shares"]), std::vector<int>({65535}));
}

TEST(WriteScenePage, TakesTextsAsTheyAre) {
  const std::string page = WrittenPage({MakeScene()});
  EXPECT_THAT(page, HasSubstr("<title>a \"part\" &lt;/script&gt;&lt;b&gt;&amp;</title>"));
  const nlohmann::json scene = ScenesOf(page)[0];
  EXPECT_EQ(scene["title"], MakeScene().title);
  EXPECT_EQ(scene["kinds"][0]["name"], "kind </title>");
  EXPECT_EQ(scene["figures"][0][1], "<i>");
}

TEST(WriteScenePage, NeedsNothingFromElsewhere) {
  const std::string page = WrittenPage({{}});
  for (const char* link : {" src=\"", "@import", "<link rel=\"stylesheet\"", "url(http"}) {
    EXPECT_EQ(page.find(link), std::string::npos) << link;
  }
}

TEST(WriteScenePage, NamesWhatDoesNotFit) {
  const TemporaryFolder folder;
  const auto message = [&](const auto& spoil) {
    Scene scene = MakeScene();
    spoil(&scene);
    return MessageOf<std::invalid_argument>([&] { WriteScenePage(folder / "a.html", {scene}); });
  };
  EXPECT_THAT(message([](Scene* s) { s->surfaces[0].triangles[0][2] = 3; }), HasSubstr("skin: index 3 of 3 points"));
  EXPECT_THAT(message([](Scene* s) { s->lines[0].segments[0][0] = -1; }), HasSubstr("edges: index -1 of 2 points"));
  EXPECT_THAT(message([](Scene* s) { s->curves[0].kind = 1; }), HasSubstr("kind 1 of 1"));
  EXPECT_THAT(message([](Scene* s) { s->boxes[0].spacings.clear(); }), HasSubstr("boxes: 0 values for 1"));
  EXPECT_THAT(message([](Scene* s) { s->boxes[0].values[0] = -1; }), HasSubstr("boxes: the value -1"));
  EXPECT_THAT(message([](Scene* s) { s->markers[0].point[0] = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("a marker: a position that is not finite"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.html"));
  EXPECT_THROW(WriteScenePage(folder / "a.html", {}), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
