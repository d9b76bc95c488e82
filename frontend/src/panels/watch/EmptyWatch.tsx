import { useState } from "react";
import { t } from "../../logic/text";
import { useBench } from "../../store/bench";
import { topVariables } from "../../store/completion";
import { addToWatch } from "../../store/watchlist";
import { Icon, type IconName } from "../../ui/Icon";

/** A list without entries says how to get some, and offers the ones most people want. */
export function EmptyWatch() {
  const instance = useBench((bench) => bench.instance);
  const model = useBench((bench) => bench.model);
  const [none, setNone] = useState<string | null>(null);
  if (!instance) return <p className="lonely faint">{t("watch.noinstance")}</p>;
  const words = model?.status_words ?? [];

  async function addProgram(): Promise<void> {
    const { paths, refused } = await topVariables();
    if (paths.length > 0) addToWatch(paths);
    else setNone(refused ?? t("watch.addprogram.none"));
  }

  return (
    <div className="empty">
      <div>
        <h3>{t("watch.empty.title")}</h3>
        <p>{t("watch.empty.about")}</p>
        <div className="ways">
          <Way icon="keyboard" strong={t("watch.empty.type")} rest={t("watch.empty.type.rest")} />
          <Way icon="drag" strong={t("watch.empty.drag")} rest={t("watch.empty.drag.rest")} />
          <Way icon="mouse" strong={t("watch.empty.click")} rest={t("watch.empty.click.rest")} />
        </div>
      </div>
      <div>
        <h3 className="small">{t("watch.empty.often")}</h3>
        <div className="offersrow">
          {words.map((word) => (
            <button key={word} type="button" className="tr offer" onClick={() => addToWatch([word])}>
              <Icon name="plus" />
              <span className="mono">{word}</span>
              <span className="meta">{word === model?.code_word ? t("watch.codeword") : t("watch.statusword")}</span>
            </button>
          ))}
        </div>
        <button type="button" className="btn sm" onClick={() => void addProgram()}>
          <Icon name="plus" small />
          {t("watch.addprogram")}
        </button>
        <p className="none" role="status">
          {none}
        </p>
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
