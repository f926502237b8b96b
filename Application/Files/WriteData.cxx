// SPDX-License-Identifier: BSD-3-Clause
#include "Files/WriteData.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/LibraryOutput.h"
#include "CommandLine/MessageCapture.h"
#include "CommandLine/ProgressLine.h"
#include "Files/WriteBytes.h"

#include "vtkCommand.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkXMLDataSetWriter.h"

namespace
{

template <class WriterT>
void Write(WriterT* writer, const std::string& path, const std::string& name)
{
  const MessageCapture messages;
  {
    const LibraryOutput output; // libpng prints what it also returns
    ProgressLine progress("writing " + name);
    progress.Observe(writer, vtkCommand::ProgressEvent);
    writer->SetFileName(path.c_str());
    writer->Write();
  }
  const bool fails = writer->GetErrorCode() != vtkErrorCode::NoError;
  if (fails || !messages.GetError().empty())
  {
    const std::string obstacle = FindWriteObstacle(path);
    throw WorkError("cannot write '" + name + "': " +
      (!obstacle.empty() ? obstacle
          : writer->GetErrorCode() == vtkErrorCode::OutOfDiskSpaceError
          ? "there was not enough space"
          : fails ? vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode())
                  : messages.GetError()));
  }
}

} // namespace

void WritePng(vtkImageData* image, const std::string& path, const std::string& name)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  Write(writer.Get(), path, name);
}

void WriteXml(vtkDataSet* data, const std::string& path, const std::string& name)
{
  vtkNew<vtkXMLDataSetWriter> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToLZ4(); // keeps up with the disk
  Write(writer.Get(), path, name);
}
