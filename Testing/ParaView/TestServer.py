# SPDX-License-Identifier: BSD-3-Clause
"""A server with the plugin shows the tool's picture to its client: TestServer.py PORT

For pvpython, while a pvserver waits at the port.
"""

import os
import sys

from paraview import simple

import pictures

simple.Connect("localhost", int(sys.argv[1]))
simple.LoadPlugin(os.environ["TETRALUX_PLUGIN"], remote=True, ns=globals())
pictures.load_plugin()
name = "disk-ray-cast"
view, _ = pictures.make_scene(name)
path = pictures.FOLDER / "server.png"
pictures.save(view, path)
pictures.finish(pictures.compare("server", path, pictures.FOLDER / f"{name}-tool.png"))
