"""The package of the tutorials: small nodes to look at and to talk with."""
