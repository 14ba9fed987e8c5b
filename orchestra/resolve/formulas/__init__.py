"""Texts that do nothing but calculate, as conditions are: how is found out once for all that are alike."""
