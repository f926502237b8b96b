// SPDX-License-Identifier: BSD-3-Clause
#ifndef SceneCamera_h
#define SceneCamera_h

struct SceneOptions;
class vtkRenderer;

/// Throws UsageError if the options contradict each other, whatever the data.
void CheckCamera(const SceneOptions& options);

/// Places a renderer's camera as the options say. By default, the focal point is the middle of the
/// bounds, and up is y, or z for a view along y. The default position is turned by 30 degrees about
/// up and raised by 20, at the distance at which all of the bounds is seen. The clipping range
/// reaches from the camera to the far end of the bounds. Throws WorkError if the data leave the
/// camera without a direction.
void PlaceCamera(const SceneOptions& options, const double bounds[6], vtkRenderer* renderer);

#endif
