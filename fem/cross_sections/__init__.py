"""Cross-sections of bars: dimensions to section constants."""
