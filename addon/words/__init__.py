"""Sentences: each message carries a key and fields, a language has a sentence for the key."""
