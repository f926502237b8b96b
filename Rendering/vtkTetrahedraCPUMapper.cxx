// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraCPUMapper.h"

#include "Frame/MapperFrame.h"
#include "Frame/PictureDrawing.h"
#include "Properties/PropertyPrinter.h"
#include "Properties/PropertySetters.h"

//------------------------------------------------------------------------------------------------
class vtkTetrahedraCPUMapper::Internals
{
public:
  tetralux::PictureDrawing Drawing;
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
  this->Private->Drawing.Draw(frame, this->GetRayDistances(),
    [this](tetralux::MapperFrame& drawn, const tetralux::PictureTask& picture)
    { return this->MakePicture(drawn, picture); });
}

//------------------------------------------------------------------------------------------------
void vtkTetrahedraCPUMapper::ReleaseResources(vtkWindow* window)
{
  this->Private->Drawing.ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------------------------
tetraluxSetNumberMacro(vtkTetrahedraCPUMapper, NumberOfThreads, int);

//------------------------------------------------------------------------------------------------
void vtkTetrahedraCPUMapper::PrintProperties(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintProperties(os, indent);
  tetralux::PropertyPrinter printer(os, indent, tetralux::FindMapperKind(this));
  printer.Print("NumberOfThreads", this->NumberOfThreads);
}
