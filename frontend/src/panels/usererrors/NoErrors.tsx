import { t } from "../../logic/text";
import { exampleFor } from "../../logic/userErrors";
import { useBench } from "../../store/bench";
import { addError, addExample } from "../../store/userErrors";
import { Icon, type IconName } from "../../ui/Icon";

/** None yet: what they are for, what one consists of, and one to begin with. */
export function NoErrors() {
  const model = useBench((bench) => bench.model);
  const example = exampleFor(model);
  return (
    <div className="empty">
      <div>
        <h3>{t("usererrors.empty.title")}</h3>
        <p>{t("usererrors.empty.about")}</p>
        <div className="ways">
          <Way
            icon="generated"
            strong={t("usererrors.empty.flag")}
            rest={t("usererrors.empty.flag.rest", { flag: example.flag })}
          />
          <Way icon="fatal" strong={t("usererrors.empty.code")} rest={t("usererrors.empty.code.rest")} />
        </div>
      </div>
      <div>
        <h3 className="small">{t("usererrors.empty.example")}</h3>
        <div className="offersrow">
          <button type="button" className="tr offer" onClick={() => addExample(example)}>
            <Icon name="plus" />
            <span>{t("usererrors.empty.example.name")}</span>
            <span className="meta mono">
              {example.code} · {example.flag}
            </span>
          </button>
        </div>
        <button type="button" className="btn sm" onClick={addError}>
          <Icon name="plus" small />
          {t("usererrors.add")}
        </button>
      </div>
    </div>
  );
}

function Way({ icon, strong, rest }: { icon: IconName; strong: string; rest: string }) {
  return (
    <div className="way">
      <Icon name={icon} />
      <span>
        <b>{strong}</b> {rest}
      </span>
    </div>
  );
}
