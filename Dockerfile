# Scanbench with its web page, built by the Makefile's own steps: what `make run` sets up is what runs here.
FROM node:22-bookworm-slim AS build
RUN apt-get update && apt-get install -y --no-install-recommends make python3 python3-venv && rm -rf /var/lib/apt/lists/*
WORKDIR /app
COPY Makefile LICENSE CHANGELOG.md ./
COPY backend backend
COPY models models
COPY docker docker
COPY docs docs
COPY frontend frontend
RUN make setup && rm -rf frontend/node_modules

# The same Debian, so the virtual environment finds its Python where it was made.
FROM debian:bookworm-slim
RUN apt-get update && apt-get install -y --no-install-recommends git python3 && rm -rf /var/lib/apt/lists/* \
  && useradd --create-home --uid 1000 bench && install -d -o bench /data
COPY --from=build /app /app
USER bench
WORKDIR /app
VOLUME /data
EXPOSE 8765
ENTRYPOINT ["/app/docker/start"]
CMD ["serve"]
