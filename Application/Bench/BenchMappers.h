// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchMappers_h
#define BenchMappers_h

#include "vtkSmartPointer.h"

struct BenchSetting;
class vtkUnstructuredGridVolumeMapper;

/// A fresh mapper as a setting describes it, without input. One ray for each pixel where the setting
/// does not say otherwise; numberOfThreads: of our own methods, 0 as many as there are cores.
vtkSmartPointer<vtkUnstructuredGridVolumeMapper> MakeBenchMapper(
  const BenchSetting& setting, int numberOfThreads);

/// Throws UsageError where an assignment is none that the mapper takes.
void CheckSetting(const BenchSetting& setting);

#endif
