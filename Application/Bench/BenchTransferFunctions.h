// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchTransferFunctions_h
#define BenchTransferFunctions_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkVolumeProperty;

/// A kind of transfer function, which can be made for any range of scalars.
struct BenchTransferFunction
{
  std::string Name;
  std::string Description;

  /// unitDistance: length over which the opacity is reached.
  vtkSmartPointer<vtkVolumeProperty> (*Make)(const double range[2], double unitDistance);
};

/// Returns all kinds: smooth, needle (a peak narrower than a texel of a table of 256 scalars),
/// steps, opaque (surfaces).
const std::vector<BenchTransferFunction>& GetBenchTransferFunctions();

/// Returns the kind of a name, which must exist.
const BenchTransferFunction& GetBenchTransferFunction(const std::string& name);

#endif
