// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_VisibilityView_h
#define tetralux_VisibilityView_h

#include <array>

namespace tetralux
{

/// From where a mesh is seen, in the coordinates of its points: all that a visibility order depends
/// on. Turning a camera about its place changes nothing.
struct VisibilityView
{
  /// Whether all rays have one direction, rather than one origin.
  bool Parallel = false;

  /// Where rays come from; not in a parallel view.
  std::array<double, 3> Eye = { 0, 0, 0 };

  /// Where rays go to in a parallel view, of any length but 0.
  std::array<double, 3> Direction = { 0, 0, -1 };
};

} // namespace tetralux

#endif
