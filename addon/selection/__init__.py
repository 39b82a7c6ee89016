"""What is selected, and what would be refused, before anything runs."""
