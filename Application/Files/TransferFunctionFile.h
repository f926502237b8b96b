// SPDX-License-Identifier: BSD-3-Clause
#ifndef TransferFunctionFile_h
#define TransferFunctionFile_h

#include "vtkColorTransferFunction.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"

#include <string>

/// Colour and opacity over the scalar.
struct ColorAndOpacity
{
  vtkNew<vtkColorTransferFunction> Color;
  vtkNew<vtkPiecewiseFunction> Opacity;
};

/// Reads a preset of ParaView: an object with RGBPoints (x, r, g, b, ...), Points (x, opacity,
/// midpoint, sharpness, ...) and ColorSpace. Of a list of such objects, it reads the first. Nodes
/// keep their scalar values. Without Points, opacity rises from 0 to 1 over the range of RGBPoints.
/// Without RGBPoints, the colours are those of MakeDefaultTransferFunction over the range of
/// Points. Throws WorkError with the file's name.
void ReadTransferFunction(const std::string& fileName, ColorAndOpacity& functions);

/// Makes ParaView's cool to warm over a range of scalars, with an opacity that rises from 0 to 1. A
/// range of one scalar is widened, so that the scalar lies in its middle.
void MakeDefaultTransferFunction(const double range[2], ColorAndOpacity& functions);

#endif
