// SPDX-License-Identifier: BSD-3-Clause
#ifndef PictureFile_h
#define PictureFile_h

#include "Setup/SceneOptions.h"

class AtomicOutput;
class vtkImageData;
class vtkRenderWindow;

/// Writes a rendered picture. A .vti gets all arrays of the image, a .png the picture over the
/// background in 8 bit. output: where to write; its extension chooses the format. image: the
/// mapper's, with RGBA premultiplied. window: shows the picture; a .png is read from it if the
/// mapper cast fewer rays than there are pixels. Throws WorkError.
void WritePicture(const AtomicOutput& output, vtkImageData* image, vtkRenderWindow* window,
  const SceneOptions::Vector& background);

#endif
