"""The supervisor's side of the fork server: it is started, asked for nodes, watched and ended here."""
