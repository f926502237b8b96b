// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ProcessOrder_h
#define tetralux_ProcessOrder_h

#include <array>
#include <vector>

class vtkMatrix4x4;
class vtkRenderer;

namespace tetralux
{

/// Lets all processes draw each frame, also those that have nothing to show, which ParaView leaves
/// out else. To be called before each frame by all processes that draw it.
void LetAllProcessesDraw(vtkRenderer* renderer);

/// The processes whose pictures ParaView composites in a renderer, the nearest one first. Empty if
/// it does not composite any in order, or for a wall of several displays.
std::vector<int> FindProcessOrder(vtkRenderer* renderer);

/// The same, the boxes of the processes being in coordinates of data, which a matrix leads to the
/// world. ParaView takes them for coordinates of the world.
std::vector<int> FindProcessOrder(vtkRenderer* renderer, vtkMatrix4x4* toWorld);

/// Where the eye is in coordinates of data: a point, or for parallel rays the direction towards the
/// eye, with 0 as the last coordinate.
std::array<double, 4> FindEye(vtkRenderer* renderer, vtkMatrix4x4* toWorld);

/// Where the origin of the window is, in pixels from a point that is common to all processes. IceT
/// moves what a process draws by whole pixels, if it fits into the window then.
std::array<double, 2> FindPictureOrigin(vtkRenderer* renderer);

} // namespace tetralux

#endif
