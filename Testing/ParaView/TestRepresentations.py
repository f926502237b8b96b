# SPDX-License-Identifier: BSD-3-Clause
"""Each representation shows what the tool shows, also after its state was saved and loaded.

For pvbatch. TETRALUX_PLUGIN: the plugin; TETRALUX_PARAVIEW_FOLDER: what prepare.py wrote.
"""

import sys

from paraview import simple, smstate

import pictures
import scenes

good = True


def check(name):
    """Renders a scene and compares it with the tool's picture."""
    view, display = pictures.make_scene(name)
    path = pictures.FOLDER / f"{name}-paraview.png"
    pictures.save(view, path)
    equal = pictures.compare(name, path, pictures.FOLDER / f"{name}-tool.png")
    equal = equal and check_count(name, display)
    if name in scenes.WITH_STATES:
        equal = check_states(name, path) and equal
    return equal


def check_count(name, display):
    """Whether the mapper has made as many tetrahedra as the tool: none of the cells was lost."""
    data = scenes.SCENES[name][0]
    if data == "neghip":
        return True
    found = pictures.get_statistics(display)["tables"]["tetrahedra"]
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
pictures.finish(good)
