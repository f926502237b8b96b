// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IsosurfaceSteps_h
#define tetralux_IsosurfaceSteps_h

#include "Isosurface/IsosurfaceOptions.h"
#include "Isosurface/IsosurfaceStep.h"
#include "Scene/VolumeScene.h"

#include <list>

namespace tetralux
{

/// The hierarchies of time steps: built for cells, refitted for points and scalars, and kept, so
/// that a step that comes back costs nothing (Wald et al. 2007, section 6: both schemes). What
/// comes back is known by its numbers, whatever array they are in.
class IsosurfaceSteps
{
public:
  /// Brings the step of a scene up to date, and forgets those used longest ago beyond
  /// IsosurfaceOptions::StepCacheBytes. threads is at least 1.
  const IsosurfaceStep& Update(VolumeScene& scene, const IsosurfaceOptions& options, int threads,
    IsosurfaceStatistics& statistics);

private:
  struct Entry
  {
    CacheKey Key;       ///< the numbers of the scalars
    CacheKey PointsKey; ///< the numbers of the points
    IsosurfaceStep Step;
  };

  void ChooseStep(const VolumeScene& scene, const IsosurfaceOptions& options, int threads,
    IsosurfaceStatistics& statistics);
  void MakeStep(Entry& entry, const VolumeScene& scene, const IsosurfaceOptions& options,
    int threads, IsosurfaceStatistics& statistics);
  void UpdatePolygons(VolumeScene& scene, const IsosurfaceOptions& options, int threads,
    IsosurfaceStatistics& statistics);
  void Forget(std::size_t bytes);

  CacheStamp Cells;         ///< that all steps are of
  CacheStamp Numbers;       ///< points and scalars of the last frame
  Cached<CacheKey> Points;  ///< the numbers of the points
  std::list<Entry> Entries; ///< the present step first, then by last use
};

} // namespace tetralux

#endif
