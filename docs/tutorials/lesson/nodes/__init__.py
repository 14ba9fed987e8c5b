"""The nodes of the tutorials, each a program: `orchestra run lesson NAME`."""
