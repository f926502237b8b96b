// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/CellComplex.h"

#include "Geometry/TetrahedronFaces.h"

#include <algorithm>

namespace tetralux
{

//----------------------------------------------------------------------------
CellComplex::CellComplex(std::vector<Cell> cells)
  : Cells(std::move(cells))
  , IsThere(Cells.size(), true)
  , Faces(2 * Cells.size())
{
  for (std::size_t i = 0; i < this->Cells.size(); ++i)
  {
    this->AddFaces(static_cast<std::int32_t>(i));
  }
}

//----------------------------------------------------------------------------
void CellComplex::AddFaces(std::int32_t number)
{
  const Cell& cell = this->Cells[number];
  for (const auto& face : OutwardFaces)
  {
    const std::int32_t a = cell[face[0]], b = cell[face[1]], c = cell[face[2]];
    std::int32_t entry = this->Faces.Find(a, b, c);
    if (entry == FaceTable::None)
    {
      entry = static_cast<std::int32_t>(this->CellsOfFaces.size());
      this->CellsOfFaces.push_back({ NoCell, NoCell });
      this->Faces.Set(a, b, c, entry);
    }
    auto& cells = this->CellsOfFaces[entry];
    cells[cells[0] == NoCell ? 0 : 1] = number;
  }
}

//----------------------------------------------------------------------------
void CellComplex::Add(const std::vector<Cell>& cells)
{
  for (const Cell& cell : cells)
  {
    this->Cells.push_back(cell);
    this->IsThere.push_back(true);
    this->AddFaces(static_cast<std::int32_t>(this->Cells.size()) - 1);
  }
}

//----------------------------------------------------------------------------
void CellComplex::Remove(const std::vector<std::int32_t>& cells)
{
  for (const std::int32_t number : cells)
  {
    this->IsThere[number] = false;
    const Cell& cell = this->Cells[number];
    for (const auto& face : OutwardFaces)
    {
      auto& pair =
        this->CellsOfFaces[this->Faces.Find(cell[face[0]], cell[face[1]], cell[face[2]])];
      pair[pair[0] == number ? 0 : 1] = NoCell;
    }
  }
}

//----------------------------------------------------------------------------
Front CellComplex::Grow(const Front& front, std::vector<std::int32_t>& absorbed) const
{
  const auto known = static_cast<std::ptrdiff_t>(absorbed.size());
  for (const auto& [a, b, c] : front)
  {
    const std::int32_t entry = this->Faces.Find(a, b, c);
    if (entry == FaceTable::None)
    {
      continue;
    }
    for (const std::int32_t number : this->CellsOfFaces[entry])
    {
      // The one in front of the triangle, if any, has been taken in before.
      if (number != NoCell && std::find(absorbed.begin(), absorbed.end(), number) == absorbed.end())
      {
        absorbed.push_back(number);
      }
    }
  }

  Front grown = front;
  for (auto number = absorbed.begin() + known; number != absorbed.end(); ++number)
  {
    const Cell& cell = this->Cells[*number];
    for (const auto& face : OutwardFaces)
    {
      // The cell's own side of its face is empty now.
      const Triangle triangle = { cell[face[0]], cell[face[2]], cell[face[1]] };
      const auto opposite = std::find_if(grown.begin(), grown.end(),
        [&triangle](const Triangle& other)
        { return std::is_permutation(other.begin(), other.end(), triangle.begin()); });
      if (opposite != grown.end())
      {
        grown.erase(opposite);
      }
      else
      {
        grown.push_back(triangle);
      }
    }
  }
  return grown;
}

//----------------------------------------------------------------------------
std::vector<Cell> CellComplex::GetCells() const
{
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < this->Cells.size(); ++i)
  {
    if (this->IsThere[i])
    {
      cells.push_back(this->Cells[i]);
    }
  }
  return cells;
}

//----------------------------------------------------------------------------
Front CellComplex::Advance(Front front, const std::vector<Cell>& cells)
{
  for (const Cell& cell : cells)
  {
    for (const auto& face : OutwardFaces)
    {
      const Triangle triangle = { cell[face[0]], cell[face[1]], cell[face[2]] };
      const auto closed = std::find_if(front.begin(), front.end(),
        [&triangle](const Triangle& other)
        { return std::is_permutation(other.begin(), other.end(), triangle.begin()); });
      if (closed != front.end())
      {
        front.erase(closed);
      }
      else
      {
        front.push_back(triangle);
      }
    }
  }
  return front;
}

} // namespace tetralux
