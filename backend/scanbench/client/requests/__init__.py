"""What can be asked, each request written once; see `scanbench.client.asking`."""
