// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchMappers_h
#define BenchMappers_h

#include "vtkSmartPointer.h"

struct BenchSetting;
class vtkUnstructuredGridVolumeMapper;

/// Makes the mapper of a setting, without input. It casts one ray a pixel unless the setting says
/// otherwise. numberOfThreads: of ray-cast; 0: one for each core.
vtkSmartPointer<vtkUnstructuredGridVolumeMapper> MakeBenchMapper(
  const BenchSetting& setting, int numberOfThreads);

/// Throws UsageError if the mapper does not take an assignment.
void CheckSetting(const BenchSetting& setting);

#endif
