// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchSetting_h
#define BenchSetting_h

#include <string>
#include <vector>

/// A way to render: a method and the properties that are set.
struct BenchSetting
{
  std::string Name; ///< of files and rows, as "table-256x16-log"
  std::string Group;
  std::string Description; ///< what it is, or what is switched off

  /// A method of this project, as --method takes it, "integral" for the reference, or a mapper of
  /// VTK:
  /// "vtk-projected-tetrahedra",
  /// "vtk-bunyk" (vtkUnstructuredGridVolumeRayCastMapper with its defaults),
  /// "vtk-bunyk-preintegration" (with vtkUnstructuredGridPreIntegration),
  /// "vtk-bunyk-closed-form" (with vtkTetrahedraRayIntegrator),
  /// and of image data
  /// "vtk-fixed-point" (vtkFixedPointVolumeRayCastMapper),
  /// "vtk-gpu" (vtkGPUVolumeRayCastMapper).
  std::string Method = "ray-cast";

  /// "Property=Value", as --set takes them; of VTK's mappers of image data, SampleDistance=Value.
  std::vector<std::string> Assignments;
};

/// Returns whether the method is one of VTK's own.
bool IsPeer(const BenchSetting& setting);

/// Returns whether the method renders image data. All others render cells.
bool RendersImages(const BenchSetting& setting);

/// Returns whether the mapper offers its picture as floating point numbers. If not, the picture is
/// read from the frame buffer, in 8 bit over black. VTK's mappers offer none, and neither does a
/// mapper that casts fewer rays than there are pixels.
bool HasFloatPicture(const BenchSetting& setting);

#endif
