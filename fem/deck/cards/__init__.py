"""From the fields of single cards to rows of the card tables."""
