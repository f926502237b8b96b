// SPDX-License-Identifier: BSD-3-Clause
#include "Files/ReadMesh.h"

#include "CommandLine/CommandErrors.h"
#include "CommandLine/LibraryOutput.h"
#include "CommandLine/MessageCapture.h"
#include "CommandLine/ProgressLine.h"
#include "CommandLine/StandardStreams.h"
#include "CommandLine/Worker.h"
#include "Files/FileChecks.h"
#include "Files/FileSeries.h"
#include "Files/MeshFormats.h"
#include "Files/SpooledInput.h"
#include "Files/TimeSteps.h"
#include "Intake/DataSetBlocks.h"
#include "Intake/DataSetCheck.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>

namespace
{

/// Whether a line of a library says that it is only a warning.
bool IsWarning(const std::string& line)
{
  const std::string word = "warning";
  return std::search(line.begin(), line.end(), word.begin(), word.end(),
           [](unsigned char a, char b) { return std::tolower(a) == b; }) != line.end();
}

/// Runs a reader's work on a file. Throws WorkError for VTK's first error, or else the first line
/// that another library prints. Prints warnings.
void Guard(const std::string& fileName, const std::function<void(Worker::Reading&)>& work)
{
  const MessageCapture messages;
  std::string line;
  try
  {
    Worker::Reading reading(fileName);
    const LibraryOutput output;
    work(reading);
    line = output.GetFirstLine();
  }
  catch (const std::bad_alloc&)
  {
    throw WorkError("cannot read '" + fileName + "': there is not enough memory, or it is damaged");
  }
  catch (const std::length_error&)
  {
    throw WorkError("cannot read '" + fileName + "': it is damaged");
  }
  const std::string error = messages.GetError();
  if (error.compare(0, 9, "Algorithm") == 0) // the pipeline's many lines about a silent reader
  {
    throw WorkError("cannot read '" + fileName + "': its reader fails without a reason");
  }
  if (!error.empty())
  {
    throw WorkError("cannot read '" + fileName + "': " + error);
  }
  if (!line.empty() && !IsWarning(line))
  {
    throw WorkError("cannot read '" + fileName + "': " + line);
  }
  messages.PrintWarnings();
  if (!line.empty())
  {
    PrintMessage("warning: '" + fileName + "': " + line);
  }
}

void CheckData(const std::string& fileName, vtkDataObject* data)
{
  const Worker::Reading reading(fileName);
  if (!data)
  {
    throw WorkError("cannot read '" + fileName + "': there is nothing in it");
  }
  for (const tetralux::DataSetBlock& block : tetralux::CollectDataSets(data))
  {
    const std::string damage = tetralux::FindDamage(block.DataSet);
    if (!damage.empty())
    {
      throw WorkError("cannot read '" + fileName + "': " + damage);
    }
  }
}

/// Tells the supervisor how far a reader is.
void Report(vtkAlgorithm* reader, Worker::Reading& reading)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&reading);
  command->SetCallback(
    [](vtkObject* object, unsigned long, void* self, void*)
    {
      static_cast<Worker::Reading*>(self)->Report(
        static_cast<vtkAlgorithm*>(object)->GetProgress());
    });
  reader->AddObserver(vtkCommand::ProgressEvent, command);
}

/// Reads one file by its reader, at the time step that input asks for. extension chooses the
/// reader. name: what errors call the file.
MeshData ReadFile(const std::string& fileName, const std::string& name,
  const std::string& extension, const InputFile& input)
{
  MeshData mesh;
  Guard(name,
    [&](Worker::Reading& reading)
    {
      ProgressLine progress("reading " + name);
      const vtkSmartPointer<vtkAlgorithm> reader =
        MakeMeshReader(fileName, extension, input.Plot3dSolution);
      progress.Observe(reader, vtkCommand::ProgressEvent);
      Report(reader, reading);
      reader->UpdateInformation();
      vtkInformation* information = reader->GetOutputInformation(0);
      auto* timesKey = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
      if (information->Has(timesKey))
      {
        const double* times = information->Get(timesKey);
        mesh.Times.assign(times, times + information->Length(timesKey));
      }
      mesh.TimeStep = ChooseTimeStep(input, mesh.Times);
      if (mesh.Times.empty())
      {
        reader->Update();
      }
      else
      {
        reader->UpdateTimeStep(mesh.Times[mesh.TimeStep]);
      }
      mesh.Data = reader->GetOutputDataObject(0);
    });
  CheckData(name, mesh.Data);
  return mesh;
}

/// Reads the parts of one time step into one data object.
MeshData ReadParts(const std::vector<std::string>& files, const InputFile& input)
{
  if (files.size() == 1)
  {
    return ReadFile(files[0], files[0], GetFormatExtension(files[0]), input);
  }
  MeshData mesh;
  auto parts = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (const std::string& file : files)
  {
    const MeshData part = ReadFile(file, file, GetFormatExtension(file), input);
    parts->SetBlock(parts->GetNumberOfBlocks(), part.Data);
    mesh.Times = part.Times;
    mesh.TimeStep = part.TimeStep;
  }
  mesh.Data = parts;
  return mesh;
}

MeshData ReadSeriesStep(const InputFile& input)
{
  std::vector<SeriesStep> series;
  if (!input.Plot3dSolution.empty())
  {
    throw WorkError("'" + input.Name + "' is a series, for which there is no PLOT3D solution");
  }
  Guard(input.Name, [&](Worker::Reading&) { series = ReadSeries(input.Name); });
  std::vector<double> times;
  times.reserve(series.size());
  for (const SeriesStep& step : series)
  {
    times.push_back(step.Time);
  }
  const std::size_t timeStep = ChooseTimeStep(input, times);
  std::vector<std::string> files; // all pieces, which a series may name each or by one of them
  for (const std::string& file : series[timeStep].Files)
  {
    for (const std::string& piece : ListPieces(file))
    {
      if (std::find(files.begin(), files.end(), piece) == files.end())
      {
        files.push_back(piece);
      }
    }
  }
  MeshData mesh = ReadParts(files, {}); // the files have their own times, or none
  mesh.Times = times;
  mesh.TimeStep = timeStep;
  return mesh;
}

/// Reads what comes out of a pipe. Readers' errors call it by the name of the file that it is in.
MeshData ReadPipe(const InputFile& input)
{
  const SpooledInput spooled(input.Name);
  const std::string path = spooled.GetPath();
  try
  {
    return ReadFile(path, spooled.GetName(), spooled.FindExtension(), input);
  }
  catch (const WorkError& error)
  {
    std::string text = error.what();
    for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path))
    {
      text.replace(at, path.size(), spooled.GetName());
    }
    throw WorkError(text);
  }
}

} // namespace

MeshData ReadMesh(const InputFile& input)
{
  if (SpooledInput::IsPipe(input.Name))
  {
    return ReadPipe(input);
  }
  InputFile file = input;
  const std::size_t comma = input.Name.find(',');
  if (input.Plot3dSolution.empty() && comma != std::string::npos &&
    !std::filesystem::exists(input.Name))
  {
    file.Name = input.Name.substr(0, comma);
    file.Plot3dSolution = input.Name.substr(comma + 1);
  }
  CheckReadable(file.Name);
  return IsSeries(file.Name) ? ReadSeriesStep(file) : ReadParts(ListPieces(file.Name), file);
}

void NoteTimeSteps(const InputFile& input, const MeshData& mesh)
{
  if (mesh.Times.size() > 1 && !input.Time && !input.TimeStep)
  {
    PrintMessage("note: '" + input.Name + "' has " + DescribeTimeSteps(mesh.Times) +
      "; this is the first, --time or --time-step chooses another");
  }
}
