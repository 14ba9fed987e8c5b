"""From files to descriptions: one module per format, positions kept from the parser."""
