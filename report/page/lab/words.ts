// Texts of the lab and of its guided experiments in the reader's language, from words/.

import english from './words/en.json';
import chinese from './words/zh.json';

export type Language = 'en'|'zh';
export const labWords: Record<Language, Record<string, string>> = {
  en: english,
  zh: chinese
};

export let labLanguage: Language =
    [document.documentElement.lang, navigator.language].some(name => /^zh/i.test(name)) ? 'zh' : 'en';

/** The text of a key, with `{name}` replaced by values. A key without a text is shown itself. */
export function say(key: string, values: Record<string, unknown> = {}) {
  const words = labWords[labLanguage][key] ?? key;
  return words.replace(/\{(\w+)\}/g, (place, name) => (name in values ? String(values[name]) : place));
}

/** A scene's question in the reader's language if it is that of a shipped scene; otherwise unchanged. */
export function questionInLanguage(question: string) {
  const key = Object.keys(english).find(each => each.startsWith('question.') && labWords.en[each] === question);
  return key ? say(key) : question;
}

/** Chooses a language; elements with text listen for 'lab-language' on the document. */
export function setLabLanguage(language: Language) {
  if (language === labLanguage) return;
  labLanguage = language;
  document.dispatchEvent(new Event('lab-language'));
}
