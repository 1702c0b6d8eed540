"""Text of a deck: lines with their places, sections, cards, fields and their values."""
