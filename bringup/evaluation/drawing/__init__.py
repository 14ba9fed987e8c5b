"""Pictures of runs, with matplotlib: one module for each picture, all of them as SVG and PNG, and a page with both."""
