// SPDX-License-Identifier: BSD-3-Clause
#ifndef Methods_h
#define Methods_h

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkRenderWindow;
class vtkAbstractVolumeMapper;

/// Returns the names that --method takes, "auto" first.
std::vector<std::string> GetMethodNames();

/// What --set can set: for each property of each method its values, default and meaning.
std::string DescribeProperties();

/// Makes the mapper of a method other than "auto", for still pictures: it casts one ray a pixel
/// unless settings say otherwise. numberOfThreads: 0 for one on each core. settings: as SetProperty
/// takes them. Throws UsageError if there is no such method, if its threads can't be set, or if a
/// setting is wrong.
vtkSmartPointer<vtkAbstractVolumeMapper> MakeMapper(
  const std::string& method, int numberOfThreads, const std::vector<std::string>& settings = {});

/// Returns whether MakeMapper would throw nothing.
bool TakesSettings(
  const std::string& method, int numberOfThreads, const std::vector<std::string>& settings);

struct MethodChoice
{
  std::string Method; ///< other than "auto"
  std::string Reason; ///< one line; empty if --method named the method
};

/// Lists the methods to try for cells, one after the other. If method is not "auto", it alone.
/// Else, of isosurfaces, isosurface, if it has all settings. Else, if the window draws on a
/// graphics card, gpu-ray-cast and projection, as far as they have all settings, and last ray-cast.
/// A number of threads leaves ray-cast alone, as software OpenGL does: rays are cast faster without
/// it in every picture that was measured. RankMethods says which one is faster.
std::vector<MethodChoice> ListMethods(const std::string& method, vtkRenderWindow* window,
  int numberOfThreads, const std::vector<std::string>& settings, bool isosurfaces = false);

#endif
