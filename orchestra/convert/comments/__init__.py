"""Comments: where they are in each language, and what each stands with."""
