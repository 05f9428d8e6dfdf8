"""Listings of other programs, number by number, beside this program's own: the data and what is made of them."""
