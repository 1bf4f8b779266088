"""Files of translations, and what belongs into them."""
