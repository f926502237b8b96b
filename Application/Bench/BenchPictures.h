// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchPictures_h
#define BenchPictures_h

#include "Bench/BenchView.h"
#include "ImageComparison.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;

/// Errors of a picture over the pixels that it or the reference covers.
tetralux::ImageErrors MeasureErrors(const BenchPicture& picture, const BenchPicture& reference);

/// A picture over black, 8 bit.
vtkSmartPointer<vtkImageData> MakeImage(const BenchPicture& picture);

/// Largest error of each pixel's channels times amplification, as grey; white from 1.
vtkSmartPointer<vtkImageData> MakeDifferenceImage(
  const BenchPicture& picture, const BenchPicture& reference, double amplification);

/// The largest power of ten, 1 at least, that leaves 99.9 % of the pixels below white.
double ChooseAmplification(const tetralux::ImageErrors& errors);

/// An image of at most size pixels along each edge: each pixel is the mean, or of a difference the
/// maximum, so that nothing is lost, of the pixels that it stands for.
vtkSmartPointer<vtkImageData> ShrinkToMean(vtkImageData* image, int size);
vtkSmartPointer<vtkImageData> ShrinkToMaximum(vtkImageData* image, int size);

/// "data:image/png;base64,..."
std::string MakePngUri(vtkImageData* image);

#endif
