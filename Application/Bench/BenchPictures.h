// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchPictures_h
#define BenchPictures_h

#include "Bench/BenchView.h"
#include "ImageComparison.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;

/// Measures the errors of a picture, over the pixels that it or the reference covers.
tetralux::ImageErrors MeasureErrors(const BenchPicture& picture, const BenchPicture& reference);

/// Makes an image of a picture over black, 8 bit.
vtkSmartPointer<vtkImageData> MakeImage(const BenchPicture& picture);

/// Makes an image of the largest error of each pixel's channels, times amplification: black is 0,
/// white is 1 or more.
vtkSmartPointer<vtkImageData> MakeDifferenceImage(
  const BenchPicture& picture, const BenchPicture& reference, double amplification);

/// Returns the largest power of ten, at least 1, that leaves 99.9 % of the pixels below white.
double ChooseAmplification(const tetralux::ImageErrors& errors);

/// Shrinks an image to at most size pixels along each edge. Each pixel is the mean or the maximum
/// of the pixels that it stands for; the maximum loses no error of a difference image.
vtkSmartPointer<vtkImageData> ShrinkToMean(vtkImageData* image, int size);
vtkSmartPointer<vtkImageData> ShrinkToMaximum(vtkImageData* image, int size);

/// Returns an image as "data:image/png;base64,...".
std::string MakePngUri(vtkImageData* image);

#endif
