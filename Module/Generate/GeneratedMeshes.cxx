// SPDX-License-Identifier: BSD-3-Clause
#include "Generate/GeneratedMeshes.h"

#include "Generate/GeneratedShape.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace tetralux
{
namespace
{

const std::vector<Recipe>& GetRecipes()
{
  static const std::vector<Recipe> recipes = {
    { "ring", "a wavy ring; in its field, strands wind around each other into a knot",
      {
        { "around", 200, 4, 20000, "hexahedra around the ring" },
        { "across", 18, 1, 2000, "hexahedra across the tube, in both directions" },
        { "waves", 3, 0, 50, "waves of the ring and of its tube, in one round" },
        { "turns", 10, 0, 200, "thirds of a turn that a strand makes in one round" },
        { "time", 0, 0, 1, "moment of a period, in which each strand moves to the next one" },
      },
      { "around", "across", "waves", "turns" }, MakeRing },
    { "ball", "a ball around the origin",
      {
        { "radius", 1, 1e-30, 1e30, "radius" },
        { "cells", 40, 3, 600, "hexahedra across the ball; makes 2.5 cells^3 tetrahedra" },
      },
      { "cells" }, MakeBall },
    { "swinging-ball", "a ball that becomes long, and wide, and twists; its field goes with it",
      {
        { "cells", 40, 6, 600, "hexahedra across the ball; makes 2.5 cells^3 tetrahedra" },
        { "time", 0, 0, 1, "moment of a period; the ball is round at 0, 0.5 and 1" },
      },
      { "cells" }, MakeSwingingBall },
    { "cylinder-with-hole", "a thick pipe, on z = 0",
      {
        { "radius", 1, 1e-30, 1e30, "outer radius" },
        { "hole", 0.5, 1e-3, 0.999, "radius of the hole, in outer radii" },
        { "height", 2, 1e-30, 1e30, "height" },
        { "across", 12, 1, 5000, "hexahedra through the wall" },
        { "around", 96, 4, 20000, "hexahedra around" },
        { "along", 48, 1, 20000, "hexahedra along the axis" },
      },
      { "across", "around", "along" }, MakeCylinderWithHole },
    { "boundary-layer", "a box of unit width, with ever thinner cells towards z = 0",
      {
        { "ratio", 1e6, 2, 1e12, "longest edge over shortest edge" },
        { "cells", 32, 1, 2000, "hexahedra along x and y" },
        { "layers", 48, 2, 5000, "layers of hexahedra along z" },
      },
      { "cells", "layers" }, MakeBoundaryLayer },
    { "gear", "a spur gear of outer radius 1, on z = 0",
      {
        { "teeth", 64, 3, 2000, "number of teeth" },
        { "bore", 0.4, 0.05, 0.9, "radius of the bore" },
        { "thickness", 0.3, 1e-3, 100, "thickness along z" },
        { "around", 8, 8, 64, "hexahedra around a tooth" },
        { "across", 10, 1, 1000, "hexahedra from the bore to the rim" },
        { "along", 10, 1, 1000, "hexahedra along z" },
      },
      { "teeth", "around", "across", "along" }, MakeGear },
    { "helical-gear", "a gear whose teeth run slantwise, of outer radius 1, on z = 0",
      {
        { "teeth", 64, 3, 2000, "number of teeth" },
        { "twist", 15, -30, 30, "turn between the lower and the upper side, in degrees" },
        { "bore", 0.4, 0.05, 0.9, "radius of the bore" },
        { "thickness", 0.3, 1e-3, 100, "thickness along z" },
        { "around", 8, 8, 64, "hexahedra around a tooth" },
        { "across", 10, 1, 1000, "hexahedra from the bore to the rim" },
        { "along", 24, 8, 1000, "hexahedra along z" },
      },
      { "teeth", "around", "across", "along" }, MakeHelicalGear },
    { "heat-sink", "a base plate of unit thickness with fins, which are as wide as their gaps",
      {
        { "fins", 9, 1, 500, "number of fins" },
        { "length", 12, 0.1, 1000, "length along y, in widths of a fin" },
        { "height", 6, 0.1, 1000, "height of the fins, in widths of a fin" },
        { "cells", 3, 1, 200, "hexahedra across a fin" },
      },
      { "fins", "cells" }, MakeHeatSink },
    { "schoenhardt", "a box with a notch that no tetrahedra can fill without points of their own",
      {
        { "twist", 30, 5, 50, "turn between the notch's bottom and top, in degrees" },
        { "cells", 8, 1, 150, "parts of each edge of the coarsest mesh" },
      },
      { "cells" }, MakeSchoenhardt },
    { "cubes", "unit cubes apart from each other",
      {
        { "count", 3, 1, 100, "cubes along each axis" },
        { "gap", 0.5, 1e-6, 1000, "gap between cubes" },
        { "cells", 6, 1, 500, "hexahedra along an edge of a cube" },
      },
      { "count", "cells" }, MakeCubes },
    { "cavity", "a unit cube with a closed cubic cavity",
      {
        { "cavity", 0.5, 0, 1, "edge of the cavity; rounded to whole hexahedra, at least one" },
        { "cells", 32, 3, 600, "hexahedra along an edge" },
      },
      { "cells" }, MakeCavity },
    { "shared-edge", "two unit cubes that share one edge and nothing else",
      {
        { "cells", 16, 1, 350, "hexahedra along an edge of a cube" },
      },
      { "cells" }, MakeSharedEdge },
    { "checkerboard", "a unit cube of solid and void blocks in turns",
      {
        { "blocks", 4, 1, 200, "blocks along an edge" },
        { "cells", 6, 1, 300, "hexahedra along an edge of a block" },
      },
      { "blocks", "cells" }, MakeCheckerboard },
    { "cycle", "bars in a circle, each above the next: seen along z, none is the farthest",
      {
        { "bars", 3, 3, 12, "number of bars" },
        { "cells", 2, 1, 100, "hexahedra through the thickness of a bar" },
      },
      { "bars", "cells" }, MakeCycle },
    { "random", "a unit cube with randomly moved points, and without some of its tetrahedra",
      {
        { "cells", 24, 1, 450, "hexahedra along an edge" },
        { "jitter", 1, 0, 1, "motion of the points, 1: as far as cells of the right sign allow" },
        { "removed", 0.1, 0, 1, "part of the tetrahedra that is missing" },
        { "seed", 1, 0, 2147483647, "start of the random numbers" },
      },
      { "cells", "seed" }, MakeRandom },
  };
  return recipes;
}

template <class Items, class GetName>
std::string ListNames(const Items& items, const GetName& getName)
{
  std::string list;
  for (const auto& item : items)
  {
    list += (list.empty() ? "" : ", ") + std::string(getName(item));
  }
  return list;
}

const Recipe& FindRecipe(const std::string& name)
{
  const std::vector<Recipe>& recipes = GetRecipes();
  const auto found = std::find_if(
    recipes.begin(), recipes.end(), [&name](const Recipe& recipe) { return recipe.Name == name; });
  if (found == recipes.end())
  {
    throw std::invalid_argument("unknown mesh '" + name + "': there are " +
      ListNames(recipes, [](const Recipe& recipe) { return recipe.Name; }));
  }
  return *found;
}

void CheckValue(const Recipe& recipe, const GeneratorParameter& parameter, double value)
{
  const bool isWhole =
    std::count(recipe.WholeNumbers.begin(), recipe.WholeNumbers.end(), parameter.Name) != 0;
  if (!(value >= parameter.Minimum && value <= parameter.Maximum) ||
    (isWhole && value != std::floor(value)))
  {
    std::ostringstream message;
    message.precision(10);
    message << "mesh '" << recipe.Name << "': " << parameter.Name << " is " << value
            << ", but must be a " << (isWhole ? "whole " : "") << "number from "
            << parameter.Minimum << " to " << parameter.Maximum;
    throw std::invalid_argument(message.str());
  }
}

} // namespace

//----------------------------------------------------------------------------
const std::vector<Generator>& GetGenerators()
{
  static const std::vector<Generator> generators = []
  {
    std::vector<Generator> list;
    for (const Recipe& recipe : GetRecipes())
    {
      list.push_back({ recipe.Name, recipe.Description, recipe.Parameters });
    }
    return list;
  }();
  return generators;
}

//----------------------------------------------------------------------------
GeneratedMesh GenerateMesh(const std::string& name, const std::map<std::string, double>& parameters)
{
  const Recipe& recipe = FindRecipe(name);
  std::map<std::string, double> values;
  for (const GeneratorParameter& parameter : recipe.Parameters)
  {
    values[parameter.Name] = parameter.Default;
  }
  for (const auto& [parameter, value] : parameters)
  {
    if (values.count(parameter) == 0)
    {
      throw std::invalid_argument("mesh '" + name + "' has no parameter '" + parameter +
        "': it has " +
        ListNames(recipe.Parameters, [](const GeneratorParameter& p) { return p.Name; }));
    }
    values[parameter] = value;
  }
  for (const GeneratorParameter& parameter : recipe.Parameters)
  {
    CheckValue(recipe, parameter, values[parameter.Name]);
  }

  GeneratedMesh result;
  recipe.Make(Values(values), result);
  return result;
}

} // namespace tetralux
