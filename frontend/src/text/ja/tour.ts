import type { tour as english } from "../en/tour";

/** Japanese: the tour of the sample. */
export const tour: Record<keyof typeof english, string> = {
  "tour.again": "最初から",
  "tour.back": "Shift+F10、または左向きの矢印で、ブロックを呼び出した所へ戻ります。",
  "tour.back.done":
    "そのステップが、変更した値も含めて取り消されました。実行のどのスキャンにも戻れます。下のタイムラインに全スキャンがあります。",
  "tour.before": "戻る",
  "tour.close": "ツアーを閉じる",
  "tour.end":
    "ツアーは以上です。もう一つのサンプル Dosing（左上で選択）では、オブジェクト、命令リスト、サブレンジを試せます。F1 は選択中の場所を説明します。",
  "tour.go":
    "ブレークポイントをもう一度クリックして削除し、F5 を 2 回押します。1 回目は最後に停止した所へ進み、2 回目で実行を続けます。",
  "tour.go.done": "プログラムは何もなかったように続きます。その間、プログラムの時間は止まっていました。",
  "tour.halt": "Main.st の 26 行目 belt(run := motor); の横をクリックして、ブレークポイントを設定します。",
  "tour.halt.done":
    "PLC はこの行の前で、全員に対して停止します。左にコールスタックと変数があり、値をクリックすると変更できます。",
  "tour.history": "「履歴」パネルを開きます。",
  "tour.history.done": "異常が試験済みとして記録されました。発生と復旧の時刻、プログラムの反応が分かります。",
  "tour.into": "F11、または下向きの矢印で、ブロックの中へ入ります。",
  "tour.into.done": "プログラムは Belt の中です。行の横の値は、このインスタンスのものです。",
  "tour.leave": "ツアーを中断する（次回はここから続きます）",
  "tour.next": "次へ",
  "tour.open": "サンプルのツアー",
  "tour.raise": "異常シミュレータで「基本I/Oユニット異常」をクリックし、「発生」を押します。",
  "tour.raise.done":
    "A402.12 が TRUE になり、lamp が保持され、ベルトが止まります。プログラムが反応しました。ツリーの下に、異常を読んだ文があります。",
  "tour.recover": "「解除」を押します。",
  "tour.recover.done": "異常は PLC のメモリから消えました。lamp は reset が TRUE になるまで点灯したままです。",
  "tour.sample": "ツアーではサンプル Conveyor を使います。左上で選択してください。",
  "tour.sample.done":
    "これはサンプル Conveyor です。オムロン CJ1M 上で、ベルト、部品カウンタ、バッファ、異常処理が動いています。",
  "tour.show": "場所を表示",
  "tour.skip": "スキップ",
  "tour.step": "ステップ {at}/{of}",
  "tour.sweep": "「すべて実行」を押し、異常スイープを開始します。",
  "tour.sweep.done":
    "各異常を、同じ状態から一つずつ発生させます。表にプログラムの反応が出ます。Inner board error は読まれても効果がなく、Battery error は読まれません。",
  "tour.title": "ツアー",
  "tour.write": "ウォッチ表の start の「変更値」欄をクリックし、TRUE と入力して Enter を押します。",
  "tour.write.done":
    "書き込みは二つのスキャンの間に行われました。次のスキャンでプログラムが start を読みます。stop またはエラーがベルトを止めていなければ、motor が TRUE になります。",
};
