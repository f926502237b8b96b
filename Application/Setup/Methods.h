// SPDX-License-Identifier: BSD-3-Clause
#ifndef Methods_h
#define Methods_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkRenderWindow;
class vtkTetrahedraVolumeMapper;

/// Names that --method takes, "auto" first.
std::vector<std::string> GetMethodNames();

/// The mapper of a method other than "auto", for still pictures: one ray a pixel unless something else
/// is set. numberOfThreads: 0 for as many as there are. settings: as SetProperty takes them. Throws
/// UsageError where there is no such method, where it has no threads to be set, and what SetProperty
/// throws.
vtkSmartPointer<vtkTetrahedraVolumeMapper> MakeMapper(
  const std::string& method, int numberOfThreads, const std::vector<std::string>& settings = {});

struct MethodChoice
{
  std::string Method; ///< other than "auto"
  std::string Reason; ///< one line; empty where it was asked for
};

/// The best method for what a window draws with, for "auto": gpu-ray-cast on a graphics card, else
/// ray-cast, and ray-cast where a property is set that only it has.
MethodChoice ChooseMethod(const std::string& method, vtkRenderWindow* window, int numberOfThreads,
  const std::vector<std::string>& settings);

/// Whether the last frame of a mapper is within its MaximumError, as far as it estimates and single
/// precision allows.
bool KeepsMaximumError(vtkTetrahedraVolumeMapper* mapper);

#endif
