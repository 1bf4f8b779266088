#include "fem/structure/memory_places.h"

#include "fem/structure/structure.h"

namespace nurbeam {

MemoryPlaces::MemoryPlaces(const Structure& structure) {
  const auto take = [&](int numbers) {
    const int first = numbers > 0 ? size : -1;
    size += numbers;
    return first;
  };
  for (const Rider& rider : structure.riders) riders.push_back(take(rider.friction ? 3 : 0));
  for (std::size_t i = 0; i < structure.stops.size(); ++i) stops.push_back(take(1));
  for (const Connector& connector : structure.connectors)
    connectors.push_back(take(connector.jumps() ? 1 : 0));
  for (const RotationalConnector& connector : structure.rotational_connectors)
    angles.push_back(take(connector.counts(structure.dimension) ? 1 : 0));
}

}  // namespace nurbeam
