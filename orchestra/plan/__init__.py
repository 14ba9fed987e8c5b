"""What will run: process specs, edges and triggers as pure data, and their renderings."""
