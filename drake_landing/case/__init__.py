"""What a case file says, validated."""
