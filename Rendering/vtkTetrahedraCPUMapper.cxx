// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraCPUMapper.h"

#include "Frame/CPUDrawing.h"
#include "Frame/MapperFrame.h"
#include "Properties/PropertyPrinter.h"
#include "Properties/PropertySetters.h"

//------------------------------------------------------------------------------------------------
class vtkTetrahedraCPUMapper::Internals
{
public:
  tetralux::CPUDrawing Drawing;
};

//------------------------------------------------------------------------------------------------
vtkTetrahedraCPUMapper::vtkTetrahedraCPUMapper()
  : Private(std::make_unique<Internals>())
{
}

//------------------------------------------------------------------------------------------------
vtkTetrahedraCPUMapper::~vtkTetrahedraCPUMapper() = default;

//------------------------------------------------------------------------------------------------
void vtkTetrahedraCPUMapper::DrawFrame(tetralux::MapperFrame& frame)
{
  tetralux::RayDistances distances;
  distances.Automatic = this->AutoAdjustSampleDistances != 0;
  distances.Fixed = this->ImageSampleDistance;
  distances.Minimum = this->MinimumImageSampleDistance;
  distances.Maximum = this->MaximumImageSampleDistance;
  this->Private->Drawing.Draw(frame, distances,
    [this](tetralux::MapperFrame& drawn, const tetralux::CPUPicture& picture)
    { return this->MakePicture(drawn, picture); });
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraCPUMapper::ReleaseResources(vtkWindow* window)
{
  this->Private->Drawing.ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------------------------
tetraluxSetNumberMacro(vtkTetrahedraCPUMapper, NumberOfThreads, int);
tetraluxSetNumberMacro(vtkTetrahedraCPUMapper, ImageSampleDistance, float);
tetraluxSetNumberMacro(vtkTetrahedraCPUMapper, MinimumImageSampleDistance, float);
tetraluxSetNumberMacro(vtkTetrahedraCPUMapper, MaximumImageSampleDistance, float);

//------------------------------------------------------------------------------------------------
void vtkTetrahedraCPUMapper::PrintProperties(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintProperties(os, indent);
  tetralux::PropertyPrinter printer(os, indent, tetralux::FindMapperKind(this));
  printer.Print("NumberOfThreads", this->NumberOfThreads);
  printer.Print("ImageSampleDistance", this->ImageSampleDistance);
  printer.Print("MinimumImageSampleDistance", this->MinimumImageSampleDistance);
  printer.Print("MaximumImageSampleDistance", this->MaximumImageSampleDistance);
  printer.Print("AutoAdjustSampleDistances", this->AutoAdjustSampleDistances);
}
