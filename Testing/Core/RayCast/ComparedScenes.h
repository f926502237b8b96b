// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ComparedScenes_h
#define tetralux_ComparedScenes_h

#include "RayScene.h"

#include <ostream>
#include <string>
#include <vector>

namespace tetralux
{
namespace box_scene
{

/// Pixels that a silhouette grazes are no more than this share of those covered, unless a scene
/// puts them there.
inline constexpr double GrazedShare = 0.01;

/// One of the scenes that are compared with the reference.
struct NamedScene
{
  std::string Name;
  RayScene (*Make)();
  double LargestGrazedShare = GrazedShare;
};

inline std::ostream& operator<<(std::ostream& stream, const NamedScene& scene)
{
  return stream << scene.Name;
}

std::vector<NamedScene> ListComparedScenes();

} // namespace box_scene
} // namespace tetralux

#endif
