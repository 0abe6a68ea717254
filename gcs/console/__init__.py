"""The live console: a swarm in three dimensions in a browser, as it flies or as it flew, and what steers it."""
