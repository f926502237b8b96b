// SPDX-License-Identifier: BSD-3-Clause
#ifndef SceneCamera_h
#define SceneCamera_h

struct SceneOptions;
class vtkRenderer;

/// Throws UsageError where the camera that the options describe by themselves can't be.
void CheckCamera(const SceneOptions& options);

/// Places a renderer's camera as the options say. What they leave open: the focal point is the
/// middle of the bounds, up is y (z where the view is along y), and the position is so far away that
/// all of the bounds is seen, turned by 30 degrees about up and raised by 20. Everything between the
/// camera and the far end of the bounds is inside the clipping range.
void PlaceCamera(const SceneOptions& options, const double bounds[6], vtkRenderer* renderer);

#endif
