"""The landing in Drake: diagram, start, run, what it logs and hands over."""
