"""Text and tables from outside become exact values, under limits of time and memory."""
