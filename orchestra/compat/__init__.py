"""The names that existing Python launch files import, as thin classes that turn into description models.

    seam.py      what they ask of the stage that resolves
    place.py     the user's line that made an object
    text.py      substitutions to templates
    building.py  models from objects
    hook.py      serves these packages as `launch`, `launch_ros`, ... where launch files are loaded, and nowhere else

Every package below has the layout of the package that it stands for, since launch files import from submodules too.
"""
