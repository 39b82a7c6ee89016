"""What callers say, checked."""
