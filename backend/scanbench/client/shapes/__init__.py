"""What the server answers, as typed dictionaries. All files here are made of the OpenAPI document."""
