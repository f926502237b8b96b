// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchScene.h"

#include "vtkImageData.h"
#include "vtkUnstructuredGrid.h"

vtkDataSet* BenchScene::GetData() const
{
  return this->IsOfImages() ? static_cast<vtkDataSet*>(this->Image) : this->Mesh;
}

bool BenchScene::IsOfImages() const { return this->Image != nullptr; }
