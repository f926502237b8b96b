# SPDX-License-Identifier: BSD-3-Clause
"""A server with the plugin shows the tool's picture to its client: TestServer.py PORT

For pvpython, while a pvserver waits at the port.
"""

import os
import sys

from paraview import simple

import pictures
import scenes

simple.Connect("localhost", int(sys.argv[1]))
simple.LoadPlugin(os.environ["TETRALUX_PLUGIN"], remote=True, ns=globals())
pictures.load_plugin()
name = "disk-ray-cast"
data, representation, settings, _ = scenes.SCENES[name]
scene = scenes.DATA[data]
view = pictures.make_view()
reader = pictures.read(data)
display = pictures.show(data, reader, view)
pictures.set_up(display, representation, scene["unit_distance"], settings)
pictures.place_camera(view, scene["position"], scene["focal_point"], scene["view_up"])
path = pictures.FOLDER / "server.png"
pictures.save(view, path)
assert pictures.compare("server", path, pictures.FOLDER / f"{name}-tool.png")
