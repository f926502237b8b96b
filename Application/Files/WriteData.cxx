// SPDX-License-Identifier: BSD-3-Clause
#include "Files/WriteData.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/MessageCapture.h"

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
  writer->SetFileName(path.c_str());
  writer->Write();
  if (writer->GetErrorCode() != vtkErrorCode::NoError)
  {
    throw WorkError("cannot write '" + name +
      "': " + vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
  }
  if (!messages.GetError().empty())
  {
    throw WorkError("cannot write '" + name + "': " + messages.GetError());
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
