"""Curves and places of a document as numbers, and back; knows neither nurbeam nor a window."""
