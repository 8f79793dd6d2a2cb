// Texts of the lab and its experiments in the reader's language (words/).

import english from './words/en.json';
import chinese from './words/zh.json';

export type Language = 'en'|'zh';
export const labWords: Record<Language, Record<string, string>> = {
  en: english,
  zh: chinese
};

export let labLanguage: Language =
    [document.documentElement.lang, navigator.language].some(name => /^zh/i.test(name)) ? 'zh' : 'en';

/** Text of a key, with values for each `{name}`. A missing text is shown as its key. */
export function say(key: string, values: Record<string, unknown> = {}) {
  const words = labWords[labLanguage][key] ?? key;
  return words.replace(/\{(\w+)\}/g, (place, name) => (name in values ? String(values[name]) : place));
}

export function questionInLanguage(question: string) {
  const key = Object.keys(english).find(each => each.startsWith('question.') && labWords.en[each] === question);
  return key ? say(key) : question;
}

/** Sets the language. Elements with text listen for 'lab-language' on the document. */
export function setLabLanguage(language: Language) {
  if (language === labLanguage) return;
  labLanguage = language;
  document.dispatchEvent(new Event('lab-language'));
}
