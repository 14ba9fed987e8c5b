"""Tests of launch descriptions: the fixtures `launch` and `plan` of the pytest plug-in, and what they return."""
