"""What a run found: measures, stages, files."""
