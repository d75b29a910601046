#include "singularity_report.h"

#include <array>
#include <cstddef>
#include <map>
#include <sstream>
#include <utility>

namespace octupole {
namespace {

struct Group {
  std::size_t curves = 0;
  std::size_t loops = 0;
  double length = 0;
};

}  // namespace

nlohmann::ordered_json CountsByType(const FieldQuality& quality) {
  nlohmann::ordered_json counts;
  for (std::size_t type = 1; type < kTurnTypeNames.size(); ++type) {
    counts[kTurnTypeNames[type]] = quality.singular_triangles_of_type[type];
  }
  return counts;
}

nlohmann::ordered_json SingularStructureReport(const SingularCurves& curves, const SurfaceSingularities& surface) {
  Group all;
  std::map<std::pair<TurnType, int>, Group> groups;  // by type and valence
  std::map<CurveEnd, std::size_t> num_ends;
  for (const SingularCurve& curve : curves.curves) {
    for (Group* group : {&all, &groups[{curve.type, curve.valence}]}) {
      ++group->curves;
      group->loops += curve.is_loop();
      group->length += curve.length;
    }
    for (const CurveEnd end : curve.ends) ++num_ends[end];
  }
  auto by_type = nlohmann::ordered_json::array();
  for (const auto& [key, group] : groups) {
    by_type.push_back({{"type", kTurnTypeNames[static_cast<std::size_t>(key.first)]},
                       {"valence", key.second},
                       {"curves", group.curves},
                       {"loops", group.loops},
                       {"length", group.length}});
  }
  std::map<int, std::size_t> points_of_index;
  for (const int index : surface.quarter_indices) ++points_of_index[index];
  points_of_index.erase(0);
  std::size_t num_points = 0;
  auto by_index = nlohmann::ordered_json::object();
  for (const auto& [index, count] : points_of_index) {
    num_points += count;
    std::ostringstream name;
    name << index / 4.;
    by_index[name.str()] = count;
  }
  auto components = nlohmann::ordered_json::array();
  for (const SurfaceComponent& component : surface.components) {
    components.push_back({{"triangles", component.triangles},
                          {"euler_characteristic", component.euler_characteristic},
                          {"index_sum", component.quarter_index_sum / 4.},
                          {"closed", component.is_closed},
                          {"all_normal", component.is_normal}});
  }
  return {{"curves", all.curves},
          {"length", all.length},
          {"loops", all.loops},
          {"nodes", curves.nodes.size()},
          {"boundary_ends", num_ends[CurveEnd::kBoundary]},
          {"node_ends", num_ends[CurveEnd::kNode]},
          {"open_ends", num_ends[CurveEnd::kOpen]},
          {"curves_by_type", by_type},
          {"surface_points", num_points},
          {"surface_points_by_index", by_index},
          {"boundary_components", components}};
}

std::string SummaryOf(const nlohmann::ordered_json& singular_structure) {
  std::map<int, std::size_t> of_valence;
  for (const auto& group : singular_structure["curves_by_type"]) {
    of_valence[group["valence"].get<int>()] += group["curves"].get<std::size_t>();
  }
  std::ostringstream line;
  line << singular_structure["curves"].get<std::size_t>() << " curves (valence 3: " << of_valence[3]
       << ", 5: " << of_valence[5] << ", other: " << of_valence[0] << ") of length "
       << singular_structure["length"].get<double>() << ", " << singular_structure["nodes"].get<std::size_t>()
       << " nodes, " << singular_structure["surface_points"].get<std::size_t>() << " points on the boundary";
  return line.str();
}

}  // namespace octupole
