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

/// Reads a preset as ParaView writes it: an object with RGBPoints (x, r, g, b, ...), Points
/// (x, opacity, midpoint, sharpness, ...), ColorSpace, or a list of such objects, of which the first
/// counts. Nodes are used at their own scalar values. Without Points, opacity rises from 0 to 1 over
/// the range of RGBPoints; without RGBPoints, the colours are those of MakeDefaultTransferFunction
/// over the range of Points.
/// Throws WorkError with the file's name.
void ReadTransferFunction(const std::string& fileName, ColorAndOpacity& functions);

/// ParaView's cool to warm over a range of scalars, with an opacity that rises from 0 to 1. A range of
/// one scalar is widened, so that the scalar gets the middle.
void MakeDefaultTransferFunction(const double range[2], ColorAndOpacity& functions);

#endif
