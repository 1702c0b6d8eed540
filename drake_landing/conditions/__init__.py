"""Ground-load conditions of the rules as balanced static cases of the full model."""
