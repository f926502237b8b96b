// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchSettings_h
#define BenchSettings_h

#include <string>
#include <vector>

struct BenchOptions;

/// A way to render: a method and what is set of it.
struct BenchSetting
{
  std::string Name; ///< of files and rows, as "table-256x16-log"
  std::string Group;
  std::string Description; ///< what it is, or what is switched off
  /// "ray-cast" or another of ours, as --method takes it, or a mapper of VTK: "vtk-projected-tetrahedra",
  /// "vtk-bunyk" (vtkUnstructuredGridVolumeRayCastMapper as it comes), "vtk-bunyk-preintegration",
  /// "vtk-bunyk-closed-form" (with vtkTetrahedraRayIntegrator).
  std::string Method = "ray-cast";
  std::vector<std::string> Assignments; ///< "Property=Value", as --set takes them
};

/// Name of the setting that all others are compared with: nothing set.
constexpr const char* DefaultSettingName = "default";

/// Group of the settings that ask for an error, and for nothing else.
constexpr const char* ErrorDialGroup = "error asked for";

/// Everything as exact as it can be had: the closed form in double precision, rays to their ends.
BenchSetting GetReferenceSetting();

/// The settings of a run, the default one first. Throws UsageError where one of the user's is none.
std::vector<BenchSetting> ListSettings(const BenchOptions& options);

/// Whether the method is one of VTK's own.
bool IsPeer(const BenchSetting& setting);

/// Whether the picture can be had as floating point numbers; else it comes from the frame buffer, in
/// 8 bit over black. It can't where there is not one ray for each pixel.
bool HasFloatPicture(const BenchSetting& setting);

#endif
