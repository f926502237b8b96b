// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchSettings_h
#define BenchSettings_h

#include <string>
#include <vector>

struct BenchOptions;

enum class BenchMethod
{
  RayCast,             ///< vtkTetrahedraRayCastMapper
  ProjectedTetrahedra, ///< vtkProjectedTetrahedraMapper
  Bunyk,               ///< vtkUnstructuredGridVolumeRayCastMapper as it comes
  BunykPreIntegration, ///< the same with vtkUnstructuredGridPreIntegration
  BunykClosedForm,     ///< the same with vtkTetrahedraRayIntegrator
};

/// A way to render: a method and what is set of it.
struct BenchSetting
{
  std::string Name; ///< of files and rows, as "table-256x16-log"
  std::string Group;
  std::string Description; ///< what it is, or what is switched off
  BenchMethod Method = BenchMethod::RayCast;
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

/// "ray-cast", "vtk-projected-tetrahedra", ...
std::string GetMethodName(BenchMethod method);

/// Whether the picture can be had as floating point numbers; else it comes from the frame buffer, in
/// 8 bit over black. It can't where there is not one ray for each pixel.
bool HasFloatPicture(const BenchSetting& setting);

#endif
