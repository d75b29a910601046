#pragma once

#include "octupole/map_solvers/internal/map_system.h"
#include "octupole/maps/map_domain.h"
#include "octupole/maps/map_quality.h"

namespace octupole::internal {

/// The unknowns of a finer domain for which its map is that of `domain`, up to shifts and the names of axes: exactly
/// where no singular edge or sheet has changed, and near it otherwise.
/// \param parameters of the tetrahedra of domain.mesh.
/// \param finer of RefineMapDomain(domain, ...).
Vector TransferMap(const MapDomain& domain, const CornerParameters& parameters, const MapDomain& finer);

}  // namespace octupole::internal
