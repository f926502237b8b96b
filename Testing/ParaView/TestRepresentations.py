# SPDX-License-Identifier: BSD-3-Clause
"""Each representation shows what the tool shows, also after its state was saved and loaded.

For pvbatch. TETRALUX_PLUGIN: the plugin; TETRALUX_PARAVIEW_FOLDER: what prepare.py wrote.
"""

import json
import sys

from paraview import simple, smstate

import pictures
import scenes

good = True


def check(name):
    """Renders a scene and compares it with the tool's picture."""
    data, representation, settings, _ = scenes.SCENES[name]
    scene = scenes.DATA[data]
    view = pictures.make_view()
    reader = pictures.read(data)
    display = pictures.show(data, reader, view)
    pictures.set_up(display, representation, scene["unit_distance"], settings)
    pictures.place_camera(view, scene["position"], scene["focal_point"], scene["view_up"])
    path = pictures.FOLDER / f"{name}-paraview.png"
    pictures.save(view, path)
    equal = pictures.compare(name, path, pictures.FOLDER / f"{name}-tool.png")
    equal = equal and check_count(name, data, display)
    if name in scenes.WITH_STATES:
        equal = check_states(name, path) and equal
    return equal


def check_count(name, data, display):
    """Whether the mapper has made as many tetrahedra as the tool: none of the cells was lost."""
    if data == "neghip":
        return True
    kind = "Isosurface" if scenes.SCENES[name][1] == "Tetralux Isosurface" else ""
    display.UpdatePropertyInformation()
    statistics = json.loads(display.GetPropertyValue(f"Tetralux{kind}Statistics"))
    found = statistics["tables"]["tetrahedra"]
    expected = pictures.COUNTS[data]["tetrahedra"]
    if found != expected:
        print(f"{name}: {found} tetrahedra instead of {expected}: FAILED")
    return found == expected


def check_states(name, path):
    """Both kinds of state restore the picture."""
    state = str(pictures.FOLDER / f"{name}.pvsm")
    script = smstate.get_state()
    simple.SaveState(state)
    simple.ResetSession()
    simple.LoadState(state)
    again = pictures.FOLDER / f"{name}-loaded.png"
    pictures.save(simple.GetActiveView(), again)
    equal = pictures.compare(f"{name}, state", again, path, largest=0)
    simple.ResetSession()
    exec(compile(script, f"{name}.py", "exec"), {"__name__": "state"})
    again = pictures.FOLDER / f"{name}-script.png"
    pictures.save(simple.GetActiveView(), again)
    equal = pictures.compare(f"{name}, Python state", again, path, largest=0) and equal
    return equal


pictures.load_plugin()
for name in sys.argv[1:] or scenes.SCENES:
    good = check(name) and good
    simple.ResetSession()
if not good:
    sys.exit(1)  # an exit by name makes this ParaView abort, which is not to be seen otherwise
