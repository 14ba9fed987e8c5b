"""Packages of definitions built: compiled once into a cache, or laid out there for the way without a compiler."""
