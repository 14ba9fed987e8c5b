"""Pages that explain the codes of problems, with a wrong and a right example each: `pages/ORCnnn.md`."""
