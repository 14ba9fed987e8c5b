"""Problems as people and programs read them: one file per format, behind the table in `formats`."""
