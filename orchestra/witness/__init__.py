"""What a result depends on: everything that was looked at on the way to it, so that it can be told whether it holds.

`observing` watches a process while it computes, `Record` is what has been seen, `World` tells whether a record still
says how things are, and `Store` keeps results with their records.

What is seen is seen by the interpreter itself: audit hooks (PEP 578) tell of every file that is opened and every folder
that is listed, by whatever code, and the functions that look without opening (`os.stat` and the like) are wrapped
meanwhile. So a part of Orchestra that begins to read something is recorded without a word. Rejected: an argument that
every reader of a file is to tell, because the one that forgets to makes a wrong answer, and because code of launch
files would never tell.
"""
