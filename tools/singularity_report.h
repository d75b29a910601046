#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "octupole/field/field_quality.h"
#include "octupole/singularities/singular_curves.h"
#include "octupole/singularities/surface_singularities.h"

namespace octupole {

/// {"quarter": n, ...}, whose sum is that of all singular triangles.
nlohmann::ordered_json CountsByType(const FieldQuality& quality);

/// The section "singular_structure" of the report.
nlohmann::ordered_json SingularStructureReport(const SingularCurves& curves, const SurfaceSingularities& surface);

/// Its line in the printed summary.
std::string SummaryOf(const nlohmann::ordered_json& singular_structure);

}  // namespace octupole
