"""Completion of command lines: what a shell asks at the Tab key, and the answer.

A shell's hook (`hooks/`) calls `orchestra completion --complete SHELL WORD ...`. Rejected: the argcomplete library,
which runs a program up to the end of its argument parser (with all imports on the way), knows no descriptions in
bash's place of words, and needs a marker in the start script; what is left of it here is the splitting of a line.
"""
