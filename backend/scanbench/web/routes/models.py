"""REST: what is known about PLC models."""

from fastapi import APIRouter

from scanbench.web import messages_models, translate
from scanbench.web.reach import Bench

router = APIRouter(prefix="/api/models", tags=["models"])


@router.get("")
async def on_models(bench: Bench) -> list[messages_models.ModelSummary]:
    """Every model."""
    return [translate.model_summary(model) for model in bench.models.values()]


@router.get("/{name}")
async def on_model(bench: Bench, name: str) -> messages_models.ModelInfo:
    """Memory areas and error catalogue of a model."""
    return translate.model_info(bench.projects.model(name))
