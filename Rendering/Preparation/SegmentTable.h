// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SegmentTable_h
#define tetralux_SegmentTable_h

#include "Optics/TransferFunction.h"
#include "PreIntegration/PreIntegrationTable.h"
#include "PreIntegration/TableChoice.h"

#include <memory>
#include <string>

namespace tetralux
{

/// The pre-integration table of a mapper: decides whether there is one and of which settings, keeps
/// it, and changes what a new transfer function touches.
class SegmentTable
{
public:
  struct Request
  {
    TableGoal Goal;
    /// A frame of an interaction: where the right one is not chosen yet, the closed form, or a
    /// coarse table if there has to be one.
    bool Interactive = false;
  };

  /// Of a transfer function. Returns whether the table changed, or came or went. Throws
  /// std::invalid_argument, as BuildPreIntegrationTable does.
  bool Update(const TransferFunction& function, const Request& request);

  /// nullptr: the closed form.
  std::shared_ptr<const PreIntegrationTable> GetTable() const { return this->Table; }

  /// What pictures are expected to be wrong by, of a channel; 0 without a table.
  double GetPictureError() const { return this->PictureError; }

  /// One line: why this table, or none.
  const std::string& GetReason() const { return this->Reason; }

  bool IsCoarse() const { return this->Coarse; }

private:
  void Build(const TransferFunction& function, const PreIntegrationSettings& settings);

  std::shared_ptr<PreIntegrationTable> Table;
  double PictureError = 0;
  std::string Reason;
  bool Coarse = false;

  // What it was decided by.
  bool Decided = false;
  TransferFunction Function;
  Request Last;
};

} // namespace tetralux

#endif
