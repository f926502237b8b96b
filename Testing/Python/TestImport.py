# SPDX-License-Identifier: BSD-3-Clause
"""Every wrapped class is an attribute of the package.

TestImport.py [FOLDER OF INSTALLED HEADERS]
"""

import pathlib
import sys
import types

import tetralux

modules = [
    value
    for name, value in vars(tetralux).items()
    if isinstance(value, types.ModuleType) and name.startswith("Tetralux")
]
classes = {name for module in modules for name in vars(module) if name.startswith("vtk")}

if len(sys.argv) > 1:
    headers = pathlib.Path(sys.argv[1]).glob("vtk*.h")
    declared = {path.stem for path in headers if f"vtkTypeMacro({path.stem}," in path.read_text()}
    assert declared, f"no header of a class in {sys.argv[1]}"
    classes |= declared

assert "vtkHeadlessRenderWindow" in classes
for name in sorted(classes):
    assert getattr(tetralux, name).__name__ == name
print(f"{len(classes)} classes in {tetralux.__file__}")
